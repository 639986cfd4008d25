"""The machines that may grant a wish: families, each with one number left free, or none.

``every`` lists them. ``family`` says what one is, and what the machines of a wish have in common;
``straight`` and ``curved`` are named after the slots; ``below``, with ``limit``, is for a peak
acceleration and no more; ``closed`` holds what is known in closed form.
"""
