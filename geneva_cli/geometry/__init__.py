"""Lines, arcs and cubics: shapes, their sizes, distances and fits."""
