#!/bin/sh
# Makes the Debian packages on a Debian that has nothing yet. The first stage of the Dockerfile.
set -eu
cd "$(dirname "$0")/../.."
apt-get update
apt-get install --no-install-recommends --yes ca-certificates git
scripts/package.sh
