"""The loads of a machine: forces, cycle, sizing, life; strength, vibration, tolerances."""
