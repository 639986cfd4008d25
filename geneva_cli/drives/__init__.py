"""The drives: what turns the crank or moves the roller. One file a kind, and what they share."""
