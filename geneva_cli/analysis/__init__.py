"""The analysis of a machine: timing, motion, peaks, loads, strength, vibration, tolerances."""
