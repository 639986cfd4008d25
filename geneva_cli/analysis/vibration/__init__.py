"""The load on an elastic shaft: what is left swinging when the wheel has come to rest."""
