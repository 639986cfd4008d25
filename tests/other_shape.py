"""Parts of a machine with outlines that no sizes give."""


def with_shape(parts, shape=None, **changed):
    """The same machine with another shape, or with other outlines, sizes or gaps."""
    other = type(parts)(parts.assembly.full)
    shape = (shape or parts.shape)._replace(**changed)
    # a rack has its sizes apart
    vars(other).update(shape=shape, **({"sizes": shape.sizes} if "sizes" in vars(parts) else {}))
    return other
