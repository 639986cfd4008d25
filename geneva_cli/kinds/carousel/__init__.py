"""Carousels: wheels on a carrier that turns about a standing finger."""

from geneva_cli.motion.kind import Kind, Quantities

KINDS = (
    Kind(
        "carousel",
        drive="kinds.carousel.motion:Carousel",
        gearings=("external", "internal"),
        refuses="kinds.carousel.motion:refuses",
        quantities=(
            Quantities(
                "carousel",
                "turn_deg velocity moving_fraction behind_deg centrifugal_N",
                after="product",
                batch="kinds.carousel.quantities:motion",
            ),
            Quantities(
                "carousel",
                "envelope_mm",
                after="parts",
                alone="kinds.carousel.quantities:envelope",
                makes_parts=True,
            ),
        ),
    ),
)
