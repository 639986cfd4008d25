"""Synthesis: from a requirement to the machines that meet it.

Its steps, one file each:

    reading       typed options                    -> a requirement
    target        the allowed motion angles, cycles and speeds
    families/     machines that may meet it, with free numbers in each family
    optimiser     a grid and ever closer samples, of many tasks as one batch
    family_search the best machine of each family, or the best that can be built
    machine_rows  description and costs of each; ``fast_parts``: its roller, and obstacles
    group_search  all rows of independent groups of machines, from all cores
    synth_search  the rows that keep the bounds, the best first
    built         sizes with which a row's parts pass every check in a full turn
    synth_table   the rows, the first of them turned, and a row as a spec; ``shown``: for people

Many specs are computed as batches: ``study.batches`` builds them and computes quantities,
``parts_data`` the data that ``fast_parts`` needs.
"""
