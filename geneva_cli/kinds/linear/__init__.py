"""The linear Geneva: a rack of slots."""
