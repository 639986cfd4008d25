"""``python -m geneva_cli``."""

from geneva_cli.app import main

main()
