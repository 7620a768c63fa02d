// SPDX-License-Identifier: Apache-2.0
#include "dpctl/commands/commands.hpp"
#include "dpctl/gsd/gsd_outcome.hpp"

namespace dpslave::dpctl {

const Command kGsd{
    "gsd",
    kOffline,
    "Checks, makes and shows GSD and type files for the master's tool",
    nullptr,
    "",
    "dpctl gsd check EURO0533.GSD\n"
    "dpctl gsd check UNWI0533.GSD --station unwinder\n"
    "dpctl gsd check LEAD2408.GSD --profile 2408f --tags-at 1 --identifiers 52,60\n"
    "dpctl gsd make --profile 590 --output 590_0533.GSD\n"
    "dpctl gsd make --profile 590 --in 55,57 --out 56 --demand --output UNWI0533.GSD\n"
    "dpctl gsd make --mapping gain-scheduling.toml --ident 0x1234 --output GAIN1234.GSD\n"
    "dpctl gsd show UNWI0533.GSD --profile 590\n"
    "dpctl gsd make --profile 605 --ident 0x1649 --table mine.csv --in 1,2 --output MINE1649.GSD\n"
    "dpctl gsd import UNWI0533.GSD --profile 590 --output unwinder.toml\n"
    "dpctl gsd import PLNT0533.GSD --profile 590 --cfg \"50 50 60\"\n"
    "dpctl gsd diff OLD.GSD NEW.GSD --profile 590\n"
    "dpctl gsd configure\n"
    "dpctl gsd types --output /media/disc",
    "1 a file is faulty",
    Asks::nobody};

} // namespace dpslave::dpctl
