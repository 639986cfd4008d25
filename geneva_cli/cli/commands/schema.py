"""``geneva schema``."""

from geneva_cli.cli.command import OUTPUT

EXAMPLES = ("geneva schema -o geneva.schema.json",)


def run(output: str = OUTPUT) -> None:
    """Print a JSON Schema (draft-07) of specs, with which editors complete and check keys."""
    import json

    from geneva_cli.output import show_text
    from geneva_cli.specfile.keys import schema

    show_text(json.dumps(schema(), indent=1, ensure_ascii=False) + "\n", output)
