# SPDX-License-Identifier: Apache-2.0
# Run in the place of the daemon, inside the sandbox of its unit: tries what a hijacked daemon would try, and prints
# "NAME: allowed" or "NAME: refused (REASON)" for each. Calls into the kernel carry arguments that it would find wrong,
# so that nothing happens where they are allowed. Needs nothing beyond perl-base.
# Environment: RUNTIME, the folder of the unit's RuntimeDirectory=.
use strict;
use warnings;
$| = 1;

my ($EPERM, $EACCES) = (1, 13);
my %number = `uname -m` =~ /^aarch64/
    ? (mmap => 222, mount => 40, unshare => 97, ptrace => 117, sethostname => 161, clock_settime => 112,
       reboot => 142, init_module => 105, bpf => 280, syslog => 116, personality => 92)
    : (mmap => 9, mount => 165, unshare => 272, ptrace => 101, sethostname => 170, clock_settime => 227,
       reboot => 169, init_module => 175, bpf => 321, syslog => 103, personality => 135);

sub report {
    my ($name, $allowed) = @_;
    print $allowed ? "$name: allowed\n" : "$name: refused ($!)\n";
}
sub call { # NAME CALL ARGUMENTS: refused only if the kernel says so, and not because of the arguments
    my ($name, $call, @arguments) = @_;
    my $done = syscall($number{$call}, @arguments) >= 0;
    report($name, $done || ($! != $EPERM && $! != $EACCES));
}
sub can_read {
    my ($path) = @_;
    return open(my $file, '<', $path);
}
sub can_write {
    my ($path) = @_;
    open(my $file, '>', $path) or return 0;
    close $file;
    return unlink $path;
}
sub can_list {
    my ($path) = @_;
    opendir(my $folder, $path) or return 0;
    return scalar grep { !/^\.\.?$/ } readdir $folder;
}
sub can_make_setuid {
    my ($path) = @_;
    open(my $file, '>', $path) or return 0;
    my $done = chmod 04755, $path;
    my $why = $!;
    unlink $path;
    $! = $why;
    return $done;
}
sub other_interfaces {
    open(my $net, '<', '/proc/self/net/dev') or return 0;
    return scalar grep { /:/ && !/^\s*lo:/ } <$net>;
}

my %family = (AF_UNIX => 1, AF_INET => 2, AF_INET6 => 10, AF_NETLINK => 16, AF_PACKET => 17);
report("socket of $_", socket(my $socket, $family{$_}, $_ eq 'AF_UNIX' ? 1 : 3, 0)) for sort keys %family;

report('writing to its runtime folder', can_write("$ENV{RUNTIME}/probe"));
report('writing to its private /tmp', can_write('/tmp/probe'));
report("writing to $_", can_write("$_/probe")) for qw(/ /etc /etc/dpslaved /usr /var/lib /var/log /boot);
report('reading its configuration', can_read('/etc/dpslaved/dpslaved.toml'));
report('reading /etc/shadow', can_read('/etc/shadow'));
report("seeing a file in $_", can_list($_)) for qw(/home /root);
report("seeing a file in the system's /tmp", -e '/tmp/of-the-system');
report('seeing the first process', -e '/proc/1/cmdline');
report('seeing more of /proc than processes', -e '/proc/cpuinfo');
report('seeing a network interface beside lo', other_interfaces());
report('a file that runs as its owner', can_make_setuid("$ENV{RUNTIME}/probe"));

call('memory to write and to execute', 'mmap', 0, 4096, 7, 0x22, -1, 0);
call('mount', 'mount', 'none', '/tmp', 'no-such-file-system', 0, 0);
call('a user namespace of its own', 'unshare', 0x10000000);
call('ptrace', 'ptrace', 16, -1, 0, 0);
call('setting the host name', 'sethostname', 'probe', -1);
call('setting the clock', 'clock_settime', 0, pack('q2', -1, -1));
call('reboot', 'reboot', 0, 0, 0, 0);
call('loading a module', 'init_module', 'none', 4, '');
call('bpf', 'bpf', -1, 0, 0);
call('reading the log of the kernel', 'syslog', 10, 0, 0);
call('another personality', 'personality', 8);
