message(FATAL_ERROR "packages are made of a shared build (BUILD_SHARED_LIBS=ON): see scripts/package.sh")
