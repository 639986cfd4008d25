"""Synthesis: from a requirement to the machines that meet it.

Its steps, one file each:

    reading        typed options                    -> a requirement (``study.target``)
    families/      machines that may meet it, with free numbers in each family
    family_search  the best machine of each family: a grid and ever closer samples
    suiting        the roller that suits each machine, or the obstacle to its parts
    synth_search   the rows of all groups with their costs, the best first
    synth_table    the rows, the first of them turned, and a row as a spec
"""
