"""Geneva or servo: electronic cams, cam indexers, and comparisons with them."""

ANSWERS = {
    "cam": "extras.servo.electronic_cam:cam",
    "cam_words": "extras.servo.electronic_cam:words",
    "against": "extras.servo.against:against",
}
LAWS = {"s-curve": "extras.servo.s_curve:SCurve"}
