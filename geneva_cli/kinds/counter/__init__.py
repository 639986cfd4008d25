"""The counter: a driver, a pinion and number wheels."""
