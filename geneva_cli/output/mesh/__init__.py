"""Meshes: solids as closed surfaces of triangles, written as STL, 3MF and OBJ."""
