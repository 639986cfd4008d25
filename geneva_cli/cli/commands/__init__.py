"""The commands, one file each: parse options, call the core, hand the result to the output.

A module's function ``run`` is the command, and its docstring the command's help. Its annotations
are objects, without ``from __future__ import annotations``: as text Typer would evaluate each of
them four times a run.
"""
