"""``geneva schema``."""

from geneva_cli.commands.options import Output

EXAMPLES = ("geneva schema -o geneva.schema.json",)


def run(output: Output = "-") -> None:
    """JSON Schema (draft-07) of a spec: editors complete and check its keys with it."""
    import json

    from geneva_cli.output import show_text
    from geneva_cli.specfile.json_schema import schema

    show_text(json.dumps(schema(), indent=1, ensure_ascii=False) + "\n", output)
