"""Jets, roots and angles."""
