"""A design as a scene: what turns, what is driven by whom, and the forces between."""
