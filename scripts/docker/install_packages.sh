#!/bin/sh
# Installs the packages of a folder that users of an image want: install_packages.sh FOLDER. The second stage of
# the Dockerfile.
set -eu
apt-get update
apt-get install --no-install-recommends --yes "$1"/libceres-ed[0-9]*.deb "$1"/ceres-ed-[!d]*.deb "$1"/python3-*.deb
apt-get clean
rm -rf /var/lib/apt/lists/*
