"""Where the formulas of a report come from, in short; the code names each in its place."""

from __future__ import annotations

SOURCES = (
    "Motion: pin path, slot and motion, any two of which give the third; derivatives by Taylor "
    "coefficients that are carried along, peaks as roots of the next derivative. The closed forms "
    "of the classic wheels are in the lecture Malteski mehanizmi and in handbook no. 7, Maltese "
    "mechanisms.",
    "Curved slots and times of motion: F. Krasniqi, Improvements of kinetic properties and "
    "lifespan of Maltic cross through curved canal, University of Prishtina; geneva help numbers "
    "says where our numbers differ.",
    "Side-cranks: Polyudov and Kandyak, Kinematics of the Maltese cross mechanism with a "
    "side-crank drive, Ukrainian Academy of Printing.",
    "Motion laws: VDI 2143; R. L. Norton, Cam Design and Manufacturing Handbook.",
    "Contact stress: H. Hertz, line contact. Life of the roller: ISO 281. Shafts: the ASME code "
    "for transmission shafting. Pins: bending and shear by von Mises.",
)
