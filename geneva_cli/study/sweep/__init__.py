"""Many designs: a grid or a random cloud of them, a row each."""
