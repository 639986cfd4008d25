"""Pin path, slot and motion: any two give the third."""
