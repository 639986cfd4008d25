"""Many designs: the table of wheels, synthesis."""
