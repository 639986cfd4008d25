"""The walls of a slot, straight and curved."""
