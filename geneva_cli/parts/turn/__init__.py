"""The full turn: parts against each other at every position."""
