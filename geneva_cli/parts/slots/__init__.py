"""Slots and grooves: paths of the rollers, profiles and their samples."""
