(** * B(n), C(k), D(k) and the even condition give the order n

    n = 2k + 1 or 2k + 2, or less; any method, so any pair. *)

From Coq Require Import QArith List Arith Lia.
From Gark Require Import Stages Trees Methods Sums Check Pairs Products Conditions.
Import ListNotations.
Open Scope Q_scope.

Section Sufficient.
Variable M : method.
Variable c : nat -> V.
Variable k n : nat.
Hypothesis n_at_most : (n <= 2 * k + 2)%nat.
Hypothesis its_B : every_colour M (fun l => B M c l n).
Hypothesis its_C : every_block M (fun l m => C M c l m k).
Hypothesis its_D : every_block M (fun l m => D M c l m k).
Hypothesis its_even : (n = 2 * k + 2)%nat -> every_block M (fun l m => even M c l m k).

Local Notation ψ := (psi (Pof M) (Aof M) (oneof M)).
Local Notation Ψ := (forest (Pof M) (Aof M) (oneof M)).
Local Notation admissible_under l us := (branches_admissible (sees M) (N M) l us).
(** What a branch is worth at a vertex of colour l. *)
Definition worth l u := app (Aof M l (root u)) (scale (number_of (order u)) (ψ u)).

(** By C(k) a branch of order j ≤ k is worth j leaves: c^j. *)
Lemma small_branches d : forall l us, (size us < d)%nat -> (size us <= k)%nat -> (l < N M)%nat ->
  admissible_under l us -> veq (Ψ l us) (power_of M c l (size us)).
Proof.
  induction d; [lia|]. intros l us Hd Hk Hl Hus. destruct us as [|u r]; [apply veq_refl|].
  destruct Hus as [Hs [Hu Hr]]. destruct u as [m vs]. destruct Hu as [Hm Hvs].
  change (size (Node m vs :: r)) with (S (size vs) + size r)%nat in *.
  apply veq_trans with (mul (Pof M l) (power_of M c l (S (size vs))) (power_of M c l (size r))).
  2: apply power_plus_power.
  apply mu_below.
  - intros i Hi. change (root (Node m vs)) with m in *.
    change (order (Node m vs)) with (S (size vs)). change (ψ (Node m vs)) with (Ψ m vs).
    rewrite (app_scale (Aof M l m) _ _ i). unfold scale.
    assert (E : veq (Ψ m vs) (power_of M c m (S (size vs) - 1))).
    { replace (S (size vs) - 1)%nat with (size vs) by lia. apply IHd; try assumption; lia. }
    rewrite (app_ext (Aof M l m) _ _ E i).
    rewrite (its_C l m Hl Hm Hs (S (size vs)) ltac:(lia) i Hi). unfold scale.
    rewrite number_of_inverse by lia. fold (number_of (S (size vs))).
    field. apply number_of_not_0. lia.
  - intros i Hi. apply IHd; try assumption; lia.
Qed.

Lemma worth_of_small l u : (order u <= k)%nat -> (l < N M)%nat -> sees M l (root u) ->
  is_tree M u -> same M l (worth l u) (power_of M c l (order u)).
Proof.
  intros Ho Hl Hs Hu i Hi. destruct u as [m vs]. destruct Hu as [Hm Hvs].
  unfold worth. simpl root in *. change (order (Node m vs)) with (S (size vs)) in *.
  rewrite (app_scale (Aof M l m) _ _ i). unfold scale.
  assert (E : veq (ψ (Node m vs)) (power_of M c m (S (size vs) - 1))).
  { replace (S (size vs) - 1)%nat with (size vs) by lia.
    apply (small_branches (S (size vs))); try assumption; lia. }
  rewrite (app_ext (Aof M l m) _ _ E i), (its_C l m Hl Hm Hs (S (size vs)) ltac:(lia) i Hi).
  unfold scale. rewrite number_of_inverse by lia. field. apply number_of_not_0. lia.
Qed.

(** The condition of t with j more leaves at its root. *)
Definition holds_with t j :=
  quadrature M (root t) (mul (Pof M (root t)) (power_of M c (root t) j) (ψ t))
    (inverse (order t + j)).

(** A root of colour l with i − 1 leaves and one branch u, of order k + 1 or more. *)
Lemma one_large_branch l u i : (l < N M)%nat -> sees M l (root u) -> is_tree M u ->
  (k < order u)%nat -> (1 <= i)%nat -> (order u + i <= n)%nat ->
  (forall j, (order u + j <= n)%nat -> holds_with u j) ->
  quadrature M l (mul (Pof M l) (power_of M c l (i - 1)) (worth l u)) (inverse (order u + i)).
Proof.
  intros Hl Hs Hu Hk Hi Hn Hold e He.
  pose proof (colour_below (sees M) (N M) u Hu) as Hm.
  pose proof (number_of_not_0 i Hi) as Zi.
  pose proof (number_of_not_0 (order u) (order_pos u)) as Zu.
  pose proof (number_of_not_0 (order u + i) ltac:(lia)) as Zs. rewrite number_of_plus in Zs.
  destruct (le_lt_dec i k) as [L|L].
  - (* D(i) *)
    unfold worth. rewrite (its_D l (root u) Hl Hm Hs i _ e ltac:(lia) He).
    rewrite b_scale, (b_ext M (root u) e _ _ (mu_scale M (root u) _ _ _)), b_scale.
    rewrite (Hold i Hn e He).
    assert (H0 : b M (root u) e (ψ u) == rational (inverse (order u)) e).
    { rewrite <- (Nat.add_0_r (order u)), <- (Hold O ltac:(lia) e He). apply b_ext, veq_sym.
      apply one_left. apply psi_beyond. }
    rewrite H0. unfold rational. destruct (Nat.eqb e 0); [|ring].
    rewrite !number_of_inverse, number_of_plus by lia. field. repeat split; assumption.
  - (* the even condition: i = k + 1 and u is [τ^k] *)
    assert (Ei : i = S k) by lia. assert (Eu : order u = S k) by lia. subst i.
    assert (E : veq (ψ u) (power_of M c (root u) k)).
    { destruct u as [m vs]. destruct Hu as [_ Hvs].
    change (order (Node m vs)) with (S (size vs)) in Eu.
      injection Eu as Eu. change (root (Node m vs)) with m in *. rewrite <- Eu.
      apply (small_branches (S (size vs))); try assumption; lia. }
    unfold worth. rewrite Eu. replace (S k - 1)%nat with k by lia.
    assert (F : veq (app (Aof M l (root u)) (scale (number_of (S k)) (ψ u)))
                    (scale (number_of (S k)) (app (Aof M l (root u)) (power_of M c (root u) k)))).
    { apply veq_trans with (1 := app_scale _ _ _). intros x. unfold scale.
      rewrite (app_ext _ _ _ E x). reflexivity. }
    rewrite (b_ext M l e _ _ (mu_ext M l _ _ _ _ (veq_refl _) F)).
    rewrite (b_ext M l e _ _ (mu_scale M l _ _ _)), b_scale.
    rewrite (its_even ltac:(lia) l (root u) Hl Hm Hs e He).
    unfold rational. destruct (Nat.eqb e 0); [|ring].
    rewrite !number_of_inverse, number_of_plus, !number_of_times by lia.
    change (number_of 2) with 2. field. rewrite Eu in Zs. split; assumption.
Qed.

Lemma with_more_leaves t : is_tree M t -> forall j, (order t + j <= n)%nat -> holds_with t j.
Proof.
  induction t as [l us IH] using tree_ind'. intros [Hl Hus].
  unfold holds_with. change (root (Node l us)) with l.
  change (order (Node l us)) with (S (size us)).
  change (ψ (Node l us)) with (Ψ l us).
  induction us as [|u r IHr]; intros j Hj.
  - (* only leaves: B *)
    intros e He. change (size []) with O in *. change (Ψ l []) with (power_of M c l 0).
    rewrite (b_ext M l e _ _ (power_plus_power M c l j 0)), Nat.add_0_r.
    pose proof (its_B l Hl (S j) ltac:(lia) e He) as Bj. replace (S j - 1)%nat with j in Bj by lia.
    exact Bj.
  - destruct Hus as [Hs [Hu Hr]].
    change (Ψ l (u :: r)) with (mul (Pof M l) (worth l u) (Ψ l r)).
    change (size (u :: r)) with (order u + size r)%nat in *.
    destruct (le_lt_dec (order u) k) as [L|L]; intros e He.
    + (* a small branch is worth leaves *)
      assert (W := worth_of_small l u L Hl Hs Hu).
      rewrite (b_ext M l e _ (mul (Pof M l) (power_of M c l (j + order u)) (Ψ l r))).
      * replace (S (order u + size r) + j)%nat with (S (size r) + (j + order u))%nat by lia.
        apply IHr; [|exact Hr|lia|exact He]. intros v Hv. apply IH. right. exact Hv.
      * eapply veq_trans; [apply veq_sym, mu_assoc|]. apply mu_ext; [|apply veq_refl].
        eapply veq_trans; [apply mu_below; [intros; reflexivity|exact W]|]. apply power_plus_power.
    + (* a large branch: the others are small *)
      assert (E : veq (Ψ l r) (power_of M c l (size r)))
        by (apply (small_branches (S (size r))); try assumption; lia).
      rewrite (b_ext M l e _ (mul (Pof M l) (power_of M c l (S (j + size r) - 1)) (worth l u))).
      * replace (S (order u + size r) + j)%nat with (order u + S (j + size r))%nat by lia.
        apply (one_large_branch l u (S (j + size r))); try assumption; try lia.
        intros i Hi. apply IH; [left; reflexivity|exact Hu|exact Hi].
      * replace (S (j + size r) - 1)%nat with (j + size r)%nat by lia.
        eapply veq_trans; [apply mu_ext; [apply veq_refl|]|].
        { eapply veq_trans; [apply mu_comm|]. apply mu_ext; [exact E|apply veq_refl]. }
        eapply veq_trans; [apply veq_sym, mu_assoc|]. apply mu_ext; [|apply veq_refl].
        apply power_plus_power.
Qed.

Theorem criterion_is_sufficient : has_order M n.
Proof.
  intros t Ho Ht e He. pose proof (with_more_leaves t Ht O ltac:(lia) e He) as K.
  rewrite Nat.add_0_r in K. rewrite <- K. apply b_ext, veq_sym, one_left, psi_beyond.
Qed.
End Sufficient.
