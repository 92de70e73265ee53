# SPDX-License-Identifier: MIT
"""pip install --no-build-isolation ./python/xatlas, beside or after ./python"""

from setuptools import setup

setup(
    name="atlas-uv-xatlas",
    version="0.2.0",
    description="The interface of the package xatlas, on atlas-uv",
    license="MIT",
    python_requires=">=3.8",
    install_requires=["atlas-uv", "numpy"],
    packages=["xatlas"],
)
