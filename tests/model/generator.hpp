// SPDX-License-Identifier: Apache-2.0
/// Random steps for the model check, mostly legal, so that all states and all services are reached. It looks
/// at the model to see what would be legal now. The same seed gives the same steps.
#pragma once

#include "model.hpp"
#include "step.hpp"

#include <array>
#include <cstdint>

namespace test {

class Generator {
public:
    explicit Generator(std::uint64_t seed) : state_(seed)
    {
        state_ =
            std::uint64_t{below(1U << 31)} << 32 ^ seed * 0xD1342543DE82EF95u; // no seed continues another
    }

    /// A number below `end`, by splitmix64.
    unsigned below(unsigned end);
    /// Fills `step` with the next one.
    void next(const model::Slave& slave, std::int64_t now, Step& step);

private:
    bool one_in(unsigned n) { return below(n) == 0; }
    unsigned octet() { return below(256); }

    void pick(const model::Slave& slave, Step& step);
    void pick_service(const model::Slave& slave, Step& step);
    void let_time_pass(const model::Slave& slave, std::int64_t now, Step& step);
    void ask(Step& step, int dsap, int ssap = 62);
    void choose_master(const model::Slave& slave, Step& step);
    void choose_fc(Step& step);

    void set_prm(const model::Slave& slave, Step& step);
    void prm_header(const model::Slave& slave, Step& step);
    void user_prm(const model::Device& device, Step& step);
    unsigned how_many_tags(const model::Device& device);
    void chk_cfg(const model::Slave& slave, Step& step);
    void data_exchange(const model::Slave& slave, Step& step);
    void registers(Step& step);
    void global_control(const model::Slave& slave, Step& step);
    void other_request(Step& step);
    void give_inputs(const model::Slave& slave, Step& step);
    void give_answer(Step& step);
    void give_diag(Step& step);
    void noise(Step& step, unsigned most);
    void spoil(Step& step, unsigned one_of);

    std::uint64_t state_;
    std::array<int, 128> fc_{}; // last FC of each master
    Step last_request_{};       // for retries
    Step last_prm_{}, last_cfg_{}, last_exchange_{};
};

} // namespace test
