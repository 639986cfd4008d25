"""The verdict on a design: checks, advice, warnings, the report."""
