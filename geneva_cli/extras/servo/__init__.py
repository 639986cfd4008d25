"""Geneva or servo: electronic cams, cam indexers, and comparisons with them."""
