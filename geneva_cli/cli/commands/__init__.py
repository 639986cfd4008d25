"""The commands, one file each: parse options, call the core, hand the result to the output.

A module's function ``run`` is the command, with defaults of its options. Its docstring is the help
as it is printed, with the lists of its own options and of examples: ``as_command`` reads them. Its
annotations are objects, without ``from __future__ import annotations``: as text Typer would
evaluate each of them four times a run.
"""
