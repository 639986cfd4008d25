"""From a wish to the machines that grant it.

The way of a wish, a file a step:

    reading     what is typed                         -> a wish
    wish        what the motion angle, the cycle and the speed may be
    families/   machines that may grant it, one number of each family left free
    best        of each family the gentlest machine   -> specs
    rows        what each is and costs; ``parts``: which roller suits it, what is in its way
    quantities  the quantities of a design that the wish names, and its bounds on them
    search      all of that, the best row first
    built       sizes with which a row's parts turn and pass every check
    table       the rows, the first of them turned; ``shown``: as a person reads them
    written     one row as a spec to go on with

``spans`` holds ranges of a number. Many specs are looked at as arrays: ``together`` builds them and
asks for quantities, ``by_law`` knows those of a law's motion, ``looks`` what ``parts`` must know.
"""
