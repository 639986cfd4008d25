"""Certificates: proved bounds of the peaks and loads."""

from geneva_cli.motion.kind import Extra

EXTRA = Extra(
    answers={
        "certificate": "extras.certify.certificate:certificate",
        "peaks": "extras.certify.certificate:with_certificates",
        "loads": "extras.certify.certificate:load_certificates",
    }
)
