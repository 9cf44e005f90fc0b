#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# A batch on this machine. usage: with_xargs.sh PLAN OUT [WORKERS]
set -eu
plan=$1 out=$2 workers=${3:-$(nproc)}
mkdir -p "$out"
seq "$workers" | xargs -P "$workers" -I{} incise -q batch "$plan" -o "$out" --shard "{}/$workers"
incise -q batch "$plan" -o "$out" --merge
