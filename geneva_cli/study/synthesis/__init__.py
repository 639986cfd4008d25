"""From a wish to the machines that grant it."""
