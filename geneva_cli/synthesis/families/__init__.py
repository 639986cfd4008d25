"""Families of machines that may meet a requirement, each with one free number or none.

``every`` lists them. ``family`` defines a family and what all machines of a requirement share.
``straight`` and ``curved`` are named after the slots. ``below`` is for a requirement on peak
acceleration only. ``closed`` holds closed forms.
"""
