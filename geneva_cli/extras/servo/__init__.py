"""Geneva or servo: electronic cams, cam indexers, and comparisons with them."""

from geneva_cli.motion.kind import Extra

EXTRA = Extra(
    answers={
        "cam": "extras.servo.cam_files:cam",
        "cam_words": "extras.servo.cam_files:words",
        "against": "extras.servo.against:against",
    },
    laws={"s-curve": "extras.servo.s_curve:SCurve"},
)
