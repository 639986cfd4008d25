"""What turns the crank or moves the roller, one file a kind; what several share is beside them."""
