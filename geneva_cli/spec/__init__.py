"""The vocabulary of a spec: tables, keys, rules."""
