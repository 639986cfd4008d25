"""Linkages that carry the roller: four-bars and slider-cranks."""

from geneva_cli.motion.kind import Kind

KINDS = (
    Kind(
        "four-bar",
        drive="kinds.linkages.four_bar:FourBar",
        gearings=("external",),
        refuses="motion.compatible:of_pin_path",
        families={"alone": "kinds.linkages.four_bar_search:four_bars"},
    ),
    Kind(
        "slider-crank",
        drive="kinds.linkages.slider_crank:SliderCrank",
        gearings=("external",),
        refuses="motion.compatible:of_pin_path",
    ),
)
