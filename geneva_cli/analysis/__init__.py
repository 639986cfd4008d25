"""What a machine does: timing, motion, peaks, loads."""
