"""The processor that the extension is compiled for.

It is that of the command, so that both give the same bits at the same speed: on x86-64 level v3 (AVX2, FMA, BMI), every
processor since 2013.  On an older one the first instruction would end the interpreter without a word.
"""

import pathlib
import platform

NEEDED = ("avx2", "bmi1", "bmi2", "fma", "f16c", "movbe")


def missing(flags: str) -> list[str]:
    """The needed features that are not among the words of ``flags``."""
    there = flags.split()
    return [feature for feature in NEEDED if feature not in there]


def check() -> None:
    """Raises ImportError where Linux says that the processor is too old; elsewhere nothing is known beforehand."""
    if platform.machine() not in ("x86_64", "AMD64"):
        return
    try:
        text = pathlib.Path("/proc/cpuinfo").read_text()
    except OSError:
        return
    flags = next((line.partition(":")[2] for line in text.splitlines() if line.startswith("flags")), None)
    if flags is not None and (lacking := missing(flags)):
        raise ImportError(
            f"this processor lacks {', '.join(lacking)}: asperity is compiled for x86-64-v3. "
            'Build it from source with RUSTFLAGS="-C target-cpu=x86-64" pip install python/'
        )
