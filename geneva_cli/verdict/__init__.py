"""Is it good: checks, advice, cautions, the report."""
