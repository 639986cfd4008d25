"""The gearings: wheels outside, inside and on a sphere, and their closed forms."""
