"""The wheel that a path of the roller can drive: searches for one design and for batches."""
