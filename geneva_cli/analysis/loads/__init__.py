"""Forces, torque, stress and power: what the motion costs."""
