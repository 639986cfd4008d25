"""Geneva stops: a closed recess that blocks the crank."""
