"""The quantities of a design: which there are, and the functions that compute them."""
