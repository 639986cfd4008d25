"""The vibration of a load on an elastic shaft, during a motion and after it."""
