"""Geneva or servo: electronic cams, cam indexers, and comparisons with them."""

ANSWERS = {
    "cam": "extras.servo.cam_files:cam",
    "cam_words": "extras.servo.cam_files:words",
    "against": "extras.servo.against:against",
}
