// SPDX-License-Identifier: Apache-2.0
/// A DP slave once more, written from the wire reference alone and as plainly as possible: the judge of the
/// real one. It includes no header of the project. Numbers are plain integers, times are nanoseconds.
/// What the wire reference leaves to the device (tags, Demand Data, X-49) is from manual-coverage.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace model {

using Octets = std::vector<std::uint8_t>;

constexpr int kNoSap = -1;
constexpr int kNobody = 255; // Master_Add without an owner

enum State { power_on, wait_prm, wait_cfg, data_exch };

/// How the list of tags in User_Prm_Data ends.
enum TagList { first_zero_ends, zeros_at_end, exact, no_tags };

struct Identifier {
    int octet = 0;
    bool reads = false;
    bool writes = false;
};

/// What makes one device type differ from another.
struct Device {
    const char* name = "";
    int ident = 0;
    std::vector<Identifier> identifiers;
    int demand_identifier = 0; // 0: no Demand Data
    int most_parameters = 0;
    int most_words = 0; // 0: no such limit
    TagList list = no_tags;
    int tags_at = 0; // octet of User_Prm_Data
    int shortest_prm = 0;
    int longest_prm = 0;
    bool prm_may_be_absent = false;
    bool dpv1_status = false;
    int highest_tag = 2047;
    bool extended_demand = false;
    bool replies_as_example = false;
    int error_base = 0;
    bool sync = false;
    bool freeze = false;
    bool fail_safe = false;
    bool tries_outputs = false;
    bool waits_for_drive = false;
    int longest_diag = 6;
    int own_diag_octets = 0;
    int max_tsdr = 60;
};

/// A telegram with its fields as they are on the wire, the SAPs taken out.
struct Request {
    int fc = 0;
    int da = 0;
    int sa = 0;
    int dsap = kNoSap;
    int ssap = kNoSap;
    const std::uint8_t* data = nullptr;
    int length = 0;
    long long at = 0;
};

struct Parameter {
    int tag = 0;
    bool reads = false;
    bool writes = false;
};

/// What the drive side is asked for.
struct Order {
    enum Kind { cancel, read, write };
    Kind kind = cancel;
    int tag = 0;
    int value = 0;
    unsigned number = 0;
    unsigned layout = 0;
};

/// Answers of the drive side to an order, by what Demand Data makes of them.
enum class Access { taken, no_code, invalid_tag, read_only, out_of_range };

/// One direction: the words of the parameters and the four registers of Demand Data.
struct Image {
    int words[117] = {};
    int registers[4] = {};
};

/// Everything is public: the judge compares it.
struct Slave {
    Slave(const Device& type, int own_address) : device(type), address(own_address) {}

    void start();
    void stop();
    /// A request that is to be answered: `reply` gets the octets, not_before and not_after the window in bit
    /// times.
    void request(const Request& asked);
    void sdn(const Request& said);
    void tick(long long now);
    long long deadline() const; // -1: none

    /// What the drive side has found out about the parameters.
    struct Found {
        bool every_one_tried = false;
        bool answers = false; ///< the drive, or it was not found silent yet
        bool holds = false;   ///< the start
        bool gone = false;    ///< the drive
    };
    void set_inputs(unsigned of_layout, Found what, const int* words);
    void set_answer(unsigned number, Access how, int value);
    void set_ext_diag(const Octets& blocks, bool fault);
    void diagnosis(Octets& into) const;

    const Device& device;
    int address;

    Octets reply;
    int not_before = 11;
    int not_after = 61;

    State state = power_on;
    int owner = kNobody;
    int min_tsdr = 11;
    bool watchdog_on = false;
    long long watchdog = 0;
    long long owner_heard = 0;
    int groups = 0;
    bool sync_wanted = false, freeze_wanted = false;
    bool prm_fault = false, not_supported = false, cfg_fault = false;
    bool stat_diag = false, pending = false;
    bool waited_long_enough = false;
    bool has_begun = false;     ///< to exchange: nothing holds the start any more
    bool drive_answers = false; ///< by what was said last, whatever the layout
    long long began = 0;
    Octets user_prm;
    std::vector<int> tags;
    Octets accepted_cfg;

    unsigned layout = 0, layouts = 0;
    bool demand = false;
    std::vector<Parameter> parameters;
    int in_length = 0, out_length = 0;
    Image received, active, inputs, frozen;
    Found drive_found{};
    bool in_force = false; ///< outputs of this layout are
    long long outputs_at =
        -1; ///< of the last Data_Exchange while the start may be held; -1: none, or too old
    bool sync = false, freeze = false;
    bool has_outputs = false; // of the master, in this layout
    bool may_write = false;

    // Demand Data.
    int wanted[4] = {}; // command, tag field, extended tag, value, as far as they matter
    int demand_reply[4] = {};
    Order standing;
    unsigned orders_given = 0;
    std::vector<Order> orders;  // not fetched yet
    std::vector<unsigned> left; // layouts that ended, not fetched yet
    Octets ext_diag;            // as sent
    bool ext_diag_fault = false, ext_diag_overflow = false;

    // Frame count memory.
    bool stored = false;
    int fcbm = 0, sam = 0, stored_function = 0, stored_dsap = 0;
    Octets stored_reply;

private:
    void execute(const Request& asked);
    void srd(const Request& asked);
    void set_prm(const Request& asked);
    void take_parameters(const Request& asked);
    void refuse_prm(bool unsupported);
    bool user_prm_is_good(const std::uint8_t* user, int length, std::vector<int>& found) const;
    void chk_cfg(const Request& asked);
    bool cfg_is_good(const Request& asked, std::vector<Parameter>& found, bool& with_demand) const;
    void begin_exchange(const Request& asked, const std::vector<Parameter>& found, bool with_demand);
    void data_exchange(const Request& asked);
    void take_outputs(const Request& asked);
    void leave();
    void end_stat_diag();

    void outputs_are_in_force();
    void clear();
    void append_inputs(Octets& into) const;
    Image live_inputs() const;
    bool finding_scales() const { return stat_diag && device.tries_outputs; }

    void look_at_registers();
    void order(Order::Kind kind, int tag, int value);
    void reject(int code);

    void sd1(const Request& asked, int fc);
    void sc();
    void sd2(const Request& asked, int fc, const Octets& data);
};

} // namespace model
