"""Lines, arcs and cubics: shapes, their measures, distances and fits."""
