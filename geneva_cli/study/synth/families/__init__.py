"""Families of machines that may meet a requirement, each with one free number or none.

``every`` lists them. ``family`` defines a family and what all machines of a requirement share.
``straight`` and ``curved`` are named after the slots. ``closed`` holds closed forms.
"""
