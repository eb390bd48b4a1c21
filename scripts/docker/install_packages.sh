#!/bin/sh
# Installs the programs, the Python package, and the modules that are named, from a folder of packages:
# install_packages.sh FOLDER [gltf|hdf5|vtk|pcl|video ...]. The second stage of the Dockerfile.
set -eu
folder=$1
shift
for module in "$@"; do
  shift
  set -- "$@" "$folder"/ceres-ed-"$module"_*.deb
done
apt-get update
apt-get install --no-install-recommends --yes "$folder"/libceres-ed[0-9]*.deb "$folder"/ceres-ed-tools_*.deb \
  "$folder"/python3-ceres-ed_*.deb "$@"
apt-get clean
rm -rf /var/lib/apt/lists/*
