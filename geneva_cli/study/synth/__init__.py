"""Synthesis: from a requirement to the machines that meet it.

Its steps, one file each:

    reading     typed options                         -> a requirement
    target      the allowed motion angles, cycles and speeds
    families/   machines that may meet it, with one free number in each family
    best        the gentlest machine of each family   -> specs
    rows        description and costs of each; ``parts``: its roller, and obstacles
    quantities  the quantities of its goal and bounds
    search      all of these steps, with the best row first
    built       sizes with which a row's parts pass every check in a full turn
    replacements  the best buildable machine of a family whose best cannot be built
    table       the rows, the first of them turned; ``shown``: for people
    written     one row as a spec file

``study.spans`` holds ranges of a number. Many specs are computed as batches: ``study.batches``
builds them and computes quantities, ``parts_data`` the data that ``parts`` needs.
"""
