"""Carousels: wheels on a carrier that turns about a standing finger."""

from geneva_cli.motion.kind import Kind

KINDS = (
    Kind(
        "carousel",
        drive="kinds.carousel.motion:Carousel",
        refuses="kinds.carousel.refuses:refuses",
    ),
)
