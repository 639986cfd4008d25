"""Geneva or servo: electronic cams, cam indexers, and comparisons with them."""

from geneva_cli.motion.kind import Extra

EXTRA = Extra(
    answers={
        "cam": "extras.servo.electronic_cam:cam",
        "cam_words": "extras.servo.electronic_cam:words",
        "against": "extras.servo.against:against",
    },
    laws={"s-curve": "extras.servo.s_curve:SCurve"},
)
