"""The words of a spec: tables, keys, rules."""
