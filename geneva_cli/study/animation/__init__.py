"""A design as a scene: moving parts, links, and the forces between them."""
