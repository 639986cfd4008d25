"""The machine: engagements of pin path, slot and motion, of which two give the third."""
