"""Pin path, slot and motion of which two give the third: wheels, laws, mechanism, peaks."""
