"""The commands, one file each: parse, call the core, hand the result to the output.

A module's function ``run`` is the command, and its docstring the command's help.
"""
