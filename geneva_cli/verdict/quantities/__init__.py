"""The quantities of a design: their registry, and the functions that compute them."""
