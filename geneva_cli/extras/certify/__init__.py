"""Certificates: proved bounds of the peaks and loads."""

ANSWERS = {
    "certificate": "extras.certify.certificate:certificate",
    "peaks": "extras.certify.certificate:with_certificates",
    "loads": "extras.certify.certificate:load_certificates",
}
LAWS: dict[str, str] = {}
