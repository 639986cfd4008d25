"""Many designs: the table of wheels, sweeps, comparison, synthesis, and what shows one design."""
