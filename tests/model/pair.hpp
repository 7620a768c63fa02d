// SPDX-License-Identifier: Apache-2.0
/// The slave under test and the model beside it. Both get the same steps; after each they are compared.
#pragma once

#include "model.hpp"
#include "step.hpp"

#include "dpslave/dp/slave.hpp"
#include "dpslave/fdl/stations.hpp"

#include <array>
#include <string>

namespace test {

class Pair {
public:
    explicit Pair(const model::Device& device) : Pair(device, device) {}
    /// With two that are not the same, to see that a difference is found.
    Pair(const model::Device& of_slave, const model::Device& of_model);
    Pair(const Pair&) = delete;
    Pair& operator=(const Pair&) = delete;

    /// False: they differ. difference() says in what.
    bool take(const Step& step);
    const std::string& difference() const { return difference_; }

    const model::Slave& model() const { return model_; }
    std::int64_t now() const { return now_; }
    static constexpr int kAddress = 5;

private:
    dpslave::Instant instant() const;
    void send(const Step& step);
    void give_inputs(const Step& step);
    void give_answer(const Step& step);
    void give_diag(const Step& step);

    bool compare_reply(const dpslave::fdl::Stations::Reply& reply);
    bool compare_states();
    bool compare_deadlines();
    bool compare_snapshots();
    bool compare_outputs();
    bool compare_orders();
    bool same(const char* what, long long slave, long long model);
    bool same(const char* what, dpslave::Bytes slave, const model::Octets& model);

    dpslave::dp::Personality personality_;
    dpslave::dp::Slave slave_;
    dpslave::fdl::Stations stations_;
    model::Slave model_;
    std::int64_t now_ = 1'000'000'000'000;
    dpslave::OutputImage outputs_{};
    /// Numbers of the newest orders, newest first: the slave's and the model's.
    std::array<std::pair<std::uint32_t, unsigned>, 4> orders_{};
    bool equal_ = true;
    std::string difference_;
};

} // namespace test
