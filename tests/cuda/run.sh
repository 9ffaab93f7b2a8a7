#!/bin/sh
# Builds the estimators with CUDA, compares every method with the CPU, and times it. Needs a GPU,
# nvcc, g++, CMake and Ninja, and the headers of fmt and Boost. Arguments go to both programs:
# run.sh --methods epi_l
set -eu
cd "$(dirname "$0")/../.."
PATH=$PATH:/usr/local/cuda/bin
export PATH
cmake --preset cuda
cmake --build --preset cuda
build/cuda/tests/cuda/episcope_cuda_compare compare "$@"
build/cuda/tests/cuda/episcope_cuda_compare time --size 768 "$@"
