# SPDX-License-Identifier: Apache-2.0
# The package's own tests (debian/tests), with the programs that are installed.
# shellcheck shell=bash disable=SC2034,SC2154 # what the files of the guest share

runs_package_test() { # NAME
    AUTOPKGTEST_TMP=$(mktemp -d)
    export AUTOPKGTEST_TMP
    (cd "$AUTOPKGTEST_TMP" && bash -e "/host/autopkgtest/$1")
    rm -r "$AUTOPKGTEST_TMP"
}
package_tests() { sed -n 's/^Tests://p' /host/autopkgtest/control | tr ',' ' '; }

prove "given the package, when its own tests are counted, then there is at least one" test -n "$(package_tests)"
for name in $(package_tests); do
    prove "given the installed programs, when the package's own test $name runs, then it passes" runs_package_test "$name"
done
