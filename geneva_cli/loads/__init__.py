"""The loads of a machine: forces, torque, contact stress and power."""
