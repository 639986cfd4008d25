"""Carousels: wheels on a carrier that turns about a standing finger."""

from geneva_cli.motion.kind import Kind

KINDS = (
    Kind(
        "carousel",
        drive="kinds.carousel.motion:Carousel",
        gearings=("external", "internal"),
        refuses="kinds.carousel.motion:refuses",
        quantities={
            "product": "carousel - kinds.carousel.quantities:motion "
            "turn_deg velocity moving_fraction behind_deg centrifugal_N",
            "parts": "carousel kinds.carousel.quantities:envelope - envelope_mm",
        },
    ),
)
